#include "fe/field_frames.h"

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Von Mises stress from in-plane Cauchy stress and the stress out of plane.
    double von_mises(const Tensor<2, 2> &stress, const double out_of_plane)
    {
      const double a = stress[0][0] - stress[1][1];
      const double b = stress[1][1] - out_of_plane;
      const double c = out_of_plane - stress[0][0];
      return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * stress[0][1] * stress[1][0]);
    }

    class VonMises : public DataPostprocessorScalar<2>
    {
    public:
      explicit VonMises(const BodyProperties &body_properties)
          : DataPostprocessorScalar<2>("von_mises_stress", update_gradients)
          , properties(body_properties)
      {
      }

      void evaluate_vector_field(const DataPostprocessorInputs::Vector<2> &inputs,
                                 std::vector<Vector<double>> &computed) const override
      {
        const auto material = inputs.template get_cell<2>()->material_id();
        for (unsigned int p = 0; p < computed.size(); ++p)
        {
          computed[p](0) = 0.;
          if (material == material_id::hub)
            continue;
          Tensor<2, 2> gradient;
          for (unsigned int d = 0; d < 2; ++d)
            gradient[d] = inputs.solution_gradients[p][d];
          computed[p](0) = at_point(properties.constants.at(material), gradient);
        }
      }

    private:
      double at_point(const ElasticConstants &constants, const Tensor<2, 2> &gradient) const
      {
        const Lame lame = plane_constants(constants, properties.plane);
        if (properties.material == MaterialModel::linear)
        {
          const auto stress = linear_elastic<2>(lame, gradient).piola;
          return von_mises(stress, properties.plane == PlaneState::strain ? constants.poisson_ratio * trace(stress) : 0.);
        }
        const auto F   = Tensor<2, 2>(unit_symmetric_tensor<2>()) + gradient;
        const double J = determinant(F);
        if (properties.material == MaterialModel::st_venant_kirchhoff)
        {
          const auto stress  = st_venant_kirchhoff<2>(lame, gradient).piola * transpose(F) / J;
          const double trace = 0.5 * (F.norm_square() - 2.); // of the strain
          return von_mises(stress, properties.plane == PlaneState::strain ? lame.lambda * trace / J : 0.);
        }
        const auto stress = neo_hookean<2>(lame, F).piola * transpose(F) / J;
        return von_mises(stress, lame.lambda * std::log(J) / J);
      }

      const BodyProperties &properties;
    };
  } // namespace

  FieldFrames::FieldFrames(const ElasticBody<2> &body_, std::string folder_)
      : body(body_)
      , folder(std::move(folder_))
  {
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (entry.path().filename().string().rfind("fields", 0) == 0)
        std::filesystem::remove(entry.path());
  }

  void FieldFrames::write(const Vector<double> &displacement, const double time)
  {
    const VonMises stress(body.body_properties());
    const std::vector<DataComponentInterpretation::DataComponentInterpretation> vector(
        2, DataComponentInterpretation::component_is_part_of_vector);
    DataOut<2> data;
    data.attach_dof_handler(body.dofs());
    data.add_data_vector(displacement, std::vector<std::string>(2, "displacement"), DataOut<2>::type_dof_data, vector);
    data.add_data_vector(displacement, stress);
    data.build_patches(body.body_properties().degree);

    char name[32];
    std::snprintf(name, sizeof(name), "fields-%04zu.h5", frames.size());
    DataOutBase::DataOutFilter filter(DataOutBase::DataOutFilterFlags(true, true));
    data.write_filtered_data(filter);
    data.write_hdf5_parallel(filter, folder + "/" + name, MPI_COMM_SELF);
    frames.push_back(data.create_xdmf_entry(filter, name, time, MPI_COMM_SELF));
    data.write_xdmf_file(frames, folder + "/fields.xdmf", MPI_COMM_SELF);
  }
} // namespace sprag
