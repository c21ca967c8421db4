#include "fe/field_frames.h"

#include "results/disk_reserve.h"

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <regex>

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
    // HDF5's own entries, and the index, which is rewritten.
    constexpr std::size_t bytes_of_index = 512 * 1024;

    std::size_t bytes_of(const DataOutBase::DataOutFilter &filter)
    {
      std::size_t bytes = 24u * filter.n_nodes() + 16u * filter.n_cells();
      for (unsigned int i = 0; i < filter.n_data_sets(); ++i)
        bytes += 8u * filter.get_data_set_dim(i) * filter.n_nodes();
      return bytes;
    }
  } // namespace

  FieldFrames::FieldFrames(const ElasticBody<2> &body_, std::string folder_, std::string name_)
      : body(body_)
      , folder(std::move(folder_))
      , name(std::move(name_))
      , part(body.dofs().get_triangulation().n_active_cells())
  {
    for (const auto &cell : body.dofs().active_cell_iterators())
      part[cell->active_cell_index()] = static_cast<float>(cell->material_id());
    const std::regex earlier(name + R"((-\d+\.h5|\.xdmf))");
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (std::regex_match(entry.path().filename().string(), earlier))
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
    data.add_data_vector(part, "part", DataOut<2>::type_cell_data);
    const auto &properties = body.body_properties();
    // Of curved cells positions are in single precision, too.
    data.build_patches(body.cell_mapping(), properties.degree,
                       properties.curved ? DataOut<2>::curved_inner_cells : DataOut<2>::no_curved_cells);

    // Cells share no nodes: where parts meet, each shows a stress and a number of its own.
    char number[24];
    std::snprintf(number, sizeof(number), "-%04zu.h5", frames.size());
    const std::string file = name + number;
    DataOutBase::DataOutFilter filter(DataOutBase::DataOutFilterFlags(false, true));
    data.write_filtered_data(filter);
    require_space(folder + "/" + file, bytes_of(filter) + bytes_of_index);
    data.write_hdf5_parallel(filter, folder + "/" + file, MPI_COMM_SELF);
    frames.push_back(data.create_xdmf_entry(filter, file, time, MPI_COMM_SELF));
    data.write_xdmf_file(frames, folder + "/" + name + ".xdmf", MPI_COMM_SELF);
  }
} // namespace sprag
